! RAPID Instructions, VelSet: both values are greater than 0, and no ERROR clause is asked.
MODULE speed_override_of_nothing
  PROC main()
    VelSet 0,500;                       ! stops: VelSet 0,500: both must be greater than 0
  ERROR
    TPWrite "never";
    TRYNEXT;
  ENDPROC
ENDMODULE
