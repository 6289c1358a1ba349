! RAPID Kernel, Character set: characters without a meaning.
MODULE unknown_character
  VAR num n;

  PROC main()
    n@:=1;                      ! error: E118
    n:=3;
  ENDPROC
ENDMODULE
