! RAPID Kernel, WHILE: the condition is tested before each turn.
MODULE while_loops
  VAR num n;

  PROC main()
    WHILE n<3 DO
      n:=n+1;
    ENDWHILE
    TPWrite "n is "\Num:=n;           ! -> n is 3
    WHILE FALSE DO
      TPWrite "never";
    ENDWHILE
  ENDPROC
ENDMODULE
