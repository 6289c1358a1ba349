! RAPID Instructions, WaitUntil: \Visualize shows a window when the wait has lasted 5 s, or as it says.
MODULE window_of_a_wait
  VAR bool late;

  PROC main()
    WaitUntil OpMode()=OP_UNDEF\MaxTime:=3\TimeFlag:=late\Visualize\Header:="Too short";
    WaitUntil OpMode()=OP_UNDEF\MaxTime:=7\TimeFlag:=late\Visualize\Header:="Waiting"\MsgArray:=["for","something"]\Icon:=iconError;  ! -> Waiting / for / something
    TPWrite "late "\Bool:=late;              ! -> late TRUE
    WaitUntil OpMode()=OP_UNDEF\MaxTime:=7\Visualize\Header:="Waiting"\Message:="longer"\VisualizeTime:=6;
    ! -> Waiting / longer
    ! stops: WaitUntil waited 7 s in vain (ERR_WAIT_MAXTIME)
  ENDPROC
ENDMODULE
