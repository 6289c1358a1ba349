MODULE WaitInACondition
  ! A condition may call a function that waits for a condition of its own.
  VAR num looks:=0;

  FUNC bool isReady()
    WaitUntil looks>=0;
    looks:=looks+1;
    RETURN looks=3 AND DOutput(do1)=0;
  ENDFUNC

  PROC main()
    WaitUntil isReady()\MaxTime:=5;
    TPWrite "looks: "\Num:=looks;
  ENDPROC
ENDMODULE
