MODULE example
  PROC main()
    VelSet 50,500;
    TPWrite "slow";
  ENDPROC
ENDMODULE
