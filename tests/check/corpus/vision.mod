MODULE vision
  ! Integrated Vision and a camera of another maker
  VAR cameratarget found;
  PERS wobjdata wVision:=[FALSE,TRUE,"",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  CONST robtarget pAbove:=[[0,0,100],[0,1,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    CamSetRunMode MyCamera;
    CamReqImage MyCamera;
    CamGetResult MyCamera,found;
    MoveJ pAbove,v500,fine,tool0\WObj:=wVision;
    PickmasterStart "line1";
  ENDPROC
ENDMODULE
