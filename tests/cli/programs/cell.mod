MODULE Cell
  ! Picks a part from a tray and shows it to a fixed nozzle.
  PERS tooldata tGrip:=[TRUE,[[0,0,120],[1,0,0,0]],[1.2,[0,0,60],[1,0,0,0],0,0,0]];
  PERS tooldata tNozzle:=[FALSE,[[700,300,500],[0.707106781,0,0.707106781,0]],[0.001,[0,0,0.001],[1,0,0,0],0,0,0]];
  PERS wobjdata wTray:=[FALSE,TRUE,"",[[600,-200,200],[0.965925826,0,0,0.258819045]],[[10,20,0],[1,0,0,0]]];
  PERS wobjdata wPart:=[TRUE,TRUE,"",[[0,0,100],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  CONST robtarget pAbove:=[[50,50,200],[0,0.707106781,0.707106781,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pPick:=[[50,50,20],[0,0.707106781,0.707106781,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pHome:=[[750,0,700],[0.5,0,0.866025404,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pOld:=[[1,2,3],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    ConfJ \Off;
    ConfL \Off;
    MoveJ pHome,v500,fine,tool0;
    pick;
    MoveJ pHome,v500,fine,tool0;
    TPWrite "Done";
  ENDPROC

  PROC pick()
    MoveJ pAbove,v500,z20,tGrip\WObj:=wTray;
    MoveL pPick,v100,fine,tGrip\WObj:=wTray;
    WaitTime 0.5;
    MoveL pAbove,v200,z20,tGrip\WObj:=wTray;
  ENDPROC
ENDMODULE
