MODULE example
  VAR shapedata box;
  PROC main()
    VAR wztemporary beside; ! found
    WZBoxDef\Inside,box,[300,300,0],[400,400,600];
    WZLimSup\Temp,beside,box;
  ENDPROC
ENDMODULE
