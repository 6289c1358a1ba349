MODULE job
  ! Between the first move and the last, the arm stands: any of them may be where a run is cut off.
  CONST robtarget p1:=[[800,0,800],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2:=[[800,100,800],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveL p1,v500,z0,tool0;
    MoveJ p1,v500,z10,tool0;
    MoveJ p1,v500,z10,tool0;
    MoveJ p1,v500,z0,tool0;
    MoveL p2,v500,z0,tool0;
  ENDPROC
ENDMODULE
