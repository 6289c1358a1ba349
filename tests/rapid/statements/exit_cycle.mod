! RAPID Instructions, ExitCycle: ends this turn of main from any depth.
MODULE exit_cycle
  PROC main()
    inner;
    TPWrite "never";
  ENDPROC

  PROC inner()
    TPWrite "inner";                  ! -> inner
    ExitCycle;
    TPWrite "never";                    ! warning: F401
  ENDPROC
ENDMODULE
