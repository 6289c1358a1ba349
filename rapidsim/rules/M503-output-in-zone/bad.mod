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
