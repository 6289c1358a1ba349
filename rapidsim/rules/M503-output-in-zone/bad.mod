MODULE example
  VAR signaldo gripper;
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ p10,v500,z20,tool0;
    SetDO gripper,1; ! found
  ENDPROC
ENDMODULE
! ---
MODULE bad
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p20:=[[600,90,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  VAR signaldo gripper;
  VAR signalgo program;
  PROC main()
    MoveJ p10,v500,z20,tool0;
    SetDO gripper,1;                  ! found
    SetGO program,3;                  ! found
    MoveJ p20,v500,z20,tool0;
    PulseDO gripper;                  ! found
  ENDPROC
ENDMODULE
! ---
MODULE through_calls
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p20:=[[600,90,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR signaldo grip;
  VAR bool is_last;
  PROC main()
    MoveL p10,v300,z5,tool0;
    grip_open;                        ! found
    MoveL p20,v300,z5,tool0;
    IF is_last Reset grip;            ! found
    retreat;
    Set grip;                         ! found
    FOR i FROM 1 TO 3 DO
      grip_open;                      ! found
      MoveL p10,v300,fine,tool0;
      MoveL p20,v300,z10,tool0;
    ENDFOR
  ENDPROC
  PROC grip_open()
    SetDO grip,0;
  ENDPROC
  PROC retreat()
    MoveL p20,v300,z50,tool0;
  ENDPROC
ENDMODULE
