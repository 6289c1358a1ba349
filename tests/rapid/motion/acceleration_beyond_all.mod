! RAPID Instructions, AccSet: more than 100 % stops the program, less than 20 % is 20 %.
MODULE acceleration_beyond_all
  PROC main()
    AccSet 10,5;
    TPWrite "slow";                     ! -> slow
    AccSet 101,100;                     ! stops: AccSet 101,100: both must be greater than 0 and at most 100
  ERROR
    TPWrite "never";
    TRYNEXT;
  ENDPROC
ENDMODULE
