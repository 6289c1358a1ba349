! RAPID Kernel, Late binding: a name that nothing has is the error ERR_REFUNKPRC.
MODULE late_binding_unknown
  PROC main()
    try_job;
    %"nothing"+"_here"%;                  ! stops: no procedure is named "nothing_here" (ERR_REFUNKPRC)
  ENDPROC

  PROC try_job()
    %"job"+"9"%;
    TPWrite "went on";                    ! -> went on
  ERROR
    IF ERRNO=ERR_REFUNKPRC TRYNEXT;
  ENDPROC
ENDMODULE
