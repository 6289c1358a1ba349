MODULE example
  RECORD beaddata
    num number;
    num pressure;
    glueoffset offset;
  ENDRECORD
  RECORD glueoffset
    num on;
    num off;
  ENDRECORD
  TASK PERS beaddata gun1:=[1,5,[0,0]];
  PROC main()
    gun1.pressure:=6;
  ENDPROC
ENDMODULE
! ---
MODULE example
  RECORD beaddata
    num number;
    num pressure;
  ENDRECORD
  TASK PERS beaddata gun1:=[1,5];
  PROC main()
    gun1.pressure:=6;
  ENDPROC
ENDMODULE
