MODULE example
  PROC main()
    VAR robtarget p10;
    MoveJ p10,v500,fine,tool0; ! found
  ENDPROC
ENDMODULE
! ---
MODULE bad
  VAR pos place;
  LOCAL VAR num sizes{3};
  PROC main()
    VAR robtarget p10;
    VAR bool ready;
    MoveJ p10,v500,fine,tool0;        ! found
    IF ready TPErase;                 ! found
    WaitTime sizes{2};                ! found
    WaitTime place.x;                 ! found
    WaitTime place.y;
  ENDPROC
ENDMODULE
! ---
MODULE triggers
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR triggdata glue_on;
  VAR triggdata glue_off;
  VAR signaldo glue;
  PROC main()
    TriggIO glue_on,5\DOp:=glue,1;
    MoveJ p10,v500,fine,tool0;
    TriggL p10,v100,glue_on\T2:=glue_off,fine,tool0; ! found
  ENDPROC
ENDMODULE
