! Pick and place on an IRB 910SC-3/0.55, whose axis 3 slides: mm where other axes have degrees.
MODULE scara_pick
  ! The tool is 80 mm long, so with the flange at 220 mm (axis 3 at 0) the TCP is at 140 mm.
  PERS tooldata gripper:=[TRUE,[[0,0,80],[1,0,0,0]],[0.5,[0,0,40],[1,0,0,0],0,0,0]];
  CONST jointtarget up:=[[-45,90,-10,45,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pick:=[[350,-150,20],[0,1,0,0],[-1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget place:=[[300,200,30],[0,1,0,0],[-1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PERS num axis_3{4};
  VAR clock watch;

  PROC main()
    MoveAbsJ up,v1000,fine,gripper;
    Noted 1; ! -10
    MoveJ Offs(pick,0,0,100),v1000,fine,gripper;
    Noted 2; ! TCP at 120 mm, 20 mm below the highest: -20
    ClkStart watch;
    MoveL pick,v100,fine,gripper; ! 100 mm at 100 mm/s: a second, and what stopping takes
    ClkStop watch;
    Noted 3; ! TCP at 20 mm: -120
    TPWrite "down in "\Num:=ClkRead(watch);
    MoveL Offs(pick,0,0,100),v500,z20,gripper;
    MoveJ Offs(place,0,0,100),v1000,z20,gripper;
    MoveL place,v100,fine,gripper;
    Noted 4; ! TCP at 30 mm: -110
    MoveL Offs(place,0,0,100),v500,z20,gripper;
    MoveAbsJ up,v1000,fine,gripper;
  ENDPROC

  PROC Noted(num n)
    VAR jointtarget now;
    now:=CJointT();
    axis_3{n}:=now.robax.rax_3;
  ENDPROC
ENDMODULE
