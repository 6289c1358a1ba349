MODULE shop
  ! Each procedure is a cell of its own: those called good_ are as they should be, the others have one
  ! fault, on the line that says so.
  PERS tooldata tGrip:=[TRUE,[[0,0,100],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];
  PERS wobjdata wBelt:=[FALSE,FALSE,"CNV1",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  VAR num angle:=0;
  VAR robtarget last;

  PROC go(num x,num y,num z)
    ConfJ\Off;
    ConfL\Off;
    last:=[[x,y,z],[0,0,1,0],[0,0,0,0],[9E9,angle,9E9,9E9,9E9,9E9]];
    MoveJ Offs(last,0,0,100),v1500,z10,tGrip;
    MoveL last,v1000,fine,tGrip;
  ENDPROC

  PROC up()
    MoveL Offs(last,0,0,100),v1000,fine,tGrip;
  ENDPROC

  PROC take(num x,num y,num z)
    go x,y,z;
    SetDO doGrip,1;
    up;
  ENDPROC

  PROC put(num x,num y,num z)
    go x,y,z;
    SetDO doGrip,0;
    up;
  ENDPROC

  PROC turn(num degrees)
    angle:=degrees;
    last.extax.eax_b:=angle;
    MoveJ Offs(last,0,0,100),v1500,fine,tGrip;
  ENDPROC

  PROC good_pick()
    take 400,600,480;
    put 560,0,481;
  ENDPROC

  PROC good_reach()
    go 400,600,490;
    SetDO doGrip,1;
    up;
    put 560,0,492;
  ENDPROC

  PROC air()
    go 450,450,480;
    SetDO doGrip,1; ! fault
    up;
  ENDPROC

  PROC good_turn()
    take 400,600,480;
    put 560,0,480;
    turn 180;
    take 840,0,480;
    put 400,600,480;
  ENDPROC

  PROC turned_away()
    take 400,600,480;
    put 560,0,480;
    turn 180;
    go 560,0,480;
    SetDO doGrip,1; ! fault
    up;
  ENDPROC

  PROC good_vice()
    take 400,600,480;
    put 560,0,480;
    take 500,600,480;
    put 560,100,480;
  ENDPROC

  PROC vice_full()
    take 400,600,480;
    put 560,0,480;
    take 500,600,480;
    go 560,10,482;
    SetDO doGrip,0; ! fault
    up;
  ENDPROC

  PROC good_stack()
    take 400,600,480;
    put 500,600,560;
    take 500,600,560;
    put 560,0,480;
    take 500,600,480;
    put 560,0,560;
    turn 90;
    take 700,-140,560;
    put 400,600,480;
  ENDPROC

  PROC good_regrip()
    take 400,600,480;
    put 560,0,480;
    take 560,0,490;
    put 560,0,490;
    take 560,0,480;
    put 400,600,484;
  ENDPROC

  PROC good_belt()
    go -50,800,600;
    SetDO doRun,1;
    WaitWObj wBelt\RelDist:=200;
    SetDO doRun,0;
    take -50,800,480;
    put 400,600,560;
  ENDPROC

  PROC conveyor_passed()
    SetDO doRun,1;
    go -50,800,580;
    WaitWObj wBelt\RelDist:=200;
    SetDO doRun,0;
    go -50,800,480;
    SetDO doGrip,1; ! fault
    up;
  ENDPROC

  PROC good_belt_again()
    SetDO doRun,1;
    WaitTime 0.2;
    SetDO doRun,0;
    WaitTime 1;
    SetDO doRun,1;
    WaitWObj wBelt\RelDist:=200;
    SetDO doRun,0;
    DropWObj wBelt;
    take -50,800,480;
    put 560,0,480;
  ENDPROC

  PROC conveyor_missed()
    SetDO doRun,1;
    go 250,800,480;
    WaitTime 1; ! fault
    up;
  ENDPROC

  PROC good_outfeed()
    take 400,600,480;
    put 0,-600,480;
    WaitTime 1;
  ENDPROC

  PROC good_rides_back()
    take 400,600,480;
    put -200,800,480;
    SetDO doRun,1;
    WaitTime 0.5;
    SetDO doRun,0;
    take 0,800,480;
    put 560,0,480;
  ENDPROC

  PROC early()
    take 400,600,480;
    go 560,0,510;
    SetDO doGrip,0; ! fault
    up;
  ENDPROC

  PROC second_part()
    take 400,600,480;
    MoveJ Offs(last,100,0,100),v1500,fine,tGrip;
    MoveL Offs(last,100,0,0),v1000,fine,tGrip; ! fault
  ENDPROC

  PROC good_source()
    SetDO doFeed,1;
    take 450,-600,480;
    SetDO doFeed,0;
    put 560,0,480;
    SetDO doFeed,1;
    take 450,-600,480;
    put 560,100,480;
  ENDPROC

  PROC source_empty()
    SetDO doFeed,1;
    take 450,-600,480;
    put 560,0,480;
    go 450,-600,480;
    SetDO doGrip,1; ! fault
    up;
  ENDPROC

  PROC source_blocked()
    SetDO doFeed,1;
    WaitTime 0.1;
    SetDO doFeed,0;
    WaitTime 0.1;
    SetDO doFeed,1; ! fault
    WaitTime 0.1;
  ENDPROC

  PROC good_box()
    take 400,600,480;
    put 0,-900,480;
    take 500,600,480;
    put 100,-900,480;
    SetDO doEject,1;
    SetDO doFeed,1;
    take 450,-600,480;
    put 0,-900,480;
  ENDPROC

  PROC sink_full()
    take 400,600,480;
    put -100,-900,480;
    take 500,600,480;
    put 0,-900,480;
    SetDO doFeed,1;
    take 450,-600,480;
    go 100,-900,480;
    SetDO doGrip,0; ! fault
    up;
  ENDPROC

  PROC good_clamp()
    take 400,600,480;
    go 560,0,480;
    SetDO doLock,1;
    SetDO doGrip,0;
    up;
    turn 90;
    SetDO doLock,0;
    WaitTime 0.1;
    take 700,-140,480;
    put 400,600,480;
  ENDPROC
ENDMODULE
