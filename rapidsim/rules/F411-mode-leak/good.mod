MODULE example
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ p10,v500,fine,tool0;
    lower 1;
  ENDPROC
  PROC lower(num part)
    IF part=0 RETURN;
    ConfL\Off;
    MoveL Offs(p10,0,0,-100),v100,fine,tool0;
    ConfL\On;
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p20:=[[600,150,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    ConfL\Off;
    VelSet 50,1000;
    MoveJ p10,v500,fine,tool0;
    careful TRUE;
    settings_of_the_cell;
    ConfL\On;
  ENDPROC
  PROC settings_of_the_cell()
    AccSet 60,60;
    ConfJ\Off;
  ENDPROC
  PROC careful(bool twice)
    IF twice THEN
      AccSet 30,30;
      MoveL p20,v100,fine,tool0;
      AccSet 100,100;
    ELSE
      SingArea\Wrist;
      MoveL p10,v100,fine,tool0;
      SingArea\Off;
    ENDIF
    PDispSet [[0,0,10],[1,0,0,0]];
    MoveL p10,v100,fine,tool0;
    PDispOff;
    ! A displacement that is none.
    EOffsSet [0,0,0,0,0,0];
    PDispSet [[0,0,0],[1,0,0,0]];
    VelSet 100,5000;
    MoveL p20,v100,fine,tool0;
  ENDPROC
ENDMODULE
! ---
MODULE begins_with_settings
  CONST jointtarget home:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    prepare;
    WHILE TRUE DO
      MoveL p10,v100,fine,tool0;
    ENDWHILE
  ENDPROC
  PROC prepare()
    settings;
    ConfL\Off;
    MoveAbsJ home,v500,fine,tool0;
  ENDPROC
  PROC settings()
    AccSet 50,50;
    MoveAbsJ home,v100,fine,tool0;
  ENDPROC
ENDMODULE
