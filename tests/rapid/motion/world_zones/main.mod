! RAPID Instructions, WZDOSet: an output is set while the TCP is in a zone, as long as it is watched.
MODULE world_zones
  CONST robtarget p1:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR shapedata box;
  VAR wztemporary zone;

  PROC main()
    WZBoxDef\Inside,box,[600,50,500],[800,150,700];
    WZDOSet\Temp,zone\Inside,box,doInside,1;
    MoveJ p1,v500,fine,tool0;
    TPWrite ValToStr(DOutput(doInside));    ! -> 0
    MoveL Offs(p1,0,100,0),v500,fine,tool0;
    TPWrite ValToStr(DOutput(doInside));    ! -> 1
    WZDisable zone;
    MoveL p1,v500,fine,tool0;
    MoveL Offs(p1,0,100,0),v500,fine,tool0;
    TPWrite ValToStr(DOutput(doInside));    ! -> 0
    WZEnable zone;
    WaitTime 0.1;
    TPWrite ValToStr(DOutput(doInside));    ! -> 1
    WZFree zone;
  ENDPROC
ENDMODULE
