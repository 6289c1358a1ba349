MODULE Circle
  ! A seam around a flange: down to the start, round in two half circles, and away.
  ! A circle needs two MoveC: one spans 240 degrees at most.
  !
  !   rapidsim run programs/circle.mod

  TASK PERS tooldata tTorch:=[TRUE,[[80,0,210],[0.9659258,0,0.2588190,0]],[1.2,[30,0,80],[1,0,0,0],0,0,0]];
  TASK PERS wobjdata wFlange:=[FALSE,TRUE,"",[[720,0,380],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];

  ! Around the origin of the work object, 160 mm across.
  CONST robtarget pAbove:=[[0,-80,120],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pFront:=[[0,-80,0],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pRight:=[[80,0,0],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pBack:=[[0,80,0],[0,0,1,0],[0,-1,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pLeft:=[[-80,0,0],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    MoveJ pAbove, v500, z20, tTorch\WObj:=wFlange;
    MoveL pFront, v100, fine, tTorch\WObj:=wFlange;
    MoveC pRight, pBack, v50, z10, tTorch\WObj:=wFlange;
    MoveC pLeft, pFront, v50, fine, tTorch\WObj:=wFlange;
    MoveL pAbove, v500, fine, tTorch\WObj:=wFlange;
  ENDPROC
ENDMODULE
