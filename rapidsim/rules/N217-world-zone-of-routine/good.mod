MODULE example
  VAR wztemporary beside;
  PROC main()
    VAR shapedata box;
    WZBoxDef\Inside,box,[300,300,0],[400,400,600];
    WZLimSup\Temp,beside,box;
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  VAR wztemporary beside;
  PROC main()
    free beside;
  ENDPROC
  PROC free(VAR wztemporary zone)
    WZFree zone;
  ENDPROC
ENDMODULE
