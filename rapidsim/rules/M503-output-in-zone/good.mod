MODULE example
  VAR signaldo gripper;
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ p10,v500,fine,tool0;
    SetDO gripper,1;
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p20:=[[600,150,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR signaldo gripper;
  PROC main()
    MoveJ p10,v500,fine,tool0;
    SetDO gripper,1;
    MoveJ p20,v500,z20,tool0;
    MoveJ p10,v500,fine,tool0;
    Reset gripper;
    MoveJ p20,v500,z20,tool0;
    home;
    open_it;
    MoveJ p20,v500,z20,tool0;
    WaitRob\InPos;
    open_it;
  ENDPROC
  PROC home()
    MoveJ p10,v500,fine,tool0;
  ENDPROC
  PROC open_it()
    Reset gripper;
  ENDPROC
ENDMODULE
