! RAPID Functions, PPMovedInManMode: nobody moves the pointer of a run, and files of parameters stay.
MODULE pointer_not_moved
  PROC main()
    TPWrite ValToStr(PPMovedInManMode());   ! -> FALSE
    ResetPPMoved;
    TPWrite ValToStr(IsStopStateEvent(\PPMoved)); ! -> FALSE
    SaveCfgData "HOME:"\File:="eio.cfg",EIO_DOMAIN; ! warning: R104
  ENDPROC
ENDMODULE
