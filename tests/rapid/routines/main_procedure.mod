! RAPID Overview, Program execution: it begins in main, however that is written.
MODULE main_procedure
  PROC MAIN()
    TPWrite "begun";                      ! -> begun
  ENDPROC
ENDMODULE
