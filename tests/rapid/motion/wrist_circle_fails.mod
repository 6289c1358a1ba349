! RAPID Instructions, CirPathMode: axis 6 does not move a tool in line with it, so it cannot lead.
MODULE wrist_circle_fails
  CONST robtarget start:=[[900,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    MoveJ start,v500,fine,tool0;
    CirPathMode \Wrist45;
    MoveC Offs(start,0.2,0.2,0),Offs(start,0.4,0,0),v20,fine,tool0;
    CirPathMode \Wrist46;
    MoveC Offs(start,0.2,-0.2,0),start,v20,fine,tool0;
    ! stops: the wrist cannot lead the circle to `start` at 0 % (0.0 mm): the tool's z axis lies along axis 6, which cannot move it
  ENDPROC
ENDMODULE
