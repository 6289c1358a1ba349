! Field practice, Broken shapes: = where := is meant.
MODULE equals_for_becomes
  VAR num n;

  PROC main()
    n = 1;                                ! error: E140
    TPWrite "still read";
  ENDPROC
ENDMODULE
