%%%
  VERSION:1
  LANGUAGE:ENGLISH
%%%

MODULE MainModule
  ! Depalletising of crates, two layers
  CONST robtarget pHome:=[[515.20,0.00,712.04],[0.707106781,0,0.707106781,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pPick:=[[12.3,-44.12,250],[0,0.7071068,-0.7071068,0],[0,-1,1,1],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  CONST robtarget pPlace:=[[.5,5.,-1.2E+2],[0.5,-0.5,0.5,0.5],[-1,0,-1,0],[9E9,9E+9,9E9,9E9,9E9,9E9]];
  PERS num nLayer:=2;
  VAR num nCrate;
  VAR bool bBusy:=FALSE;
  PROC Main()
    ConfL\Off;
    AccSet 80,80;
    InitCell;
    MoveJ pHome,v1000,z50,tGripper;
    WHILE TRUE DO
      FOR i FROM 1 TO 6 STEP 1 DO
        nCrate:=i;
        PickCrate i;
        PlaceCrate nCrate,nLayer\slow;
      ENDFOR
      IF nLayer>0 nLayer:=nLayer-1;
      IF nLayer=0 THEN
        TPWrite "Pallet empty! Next, please: "+ValToStr(nCrate);
        WaitDI diPallet,1;
        nLayer:=2;
      ENDIF
    ENDWHILE
  ENDPROC
  PROC PickCrate(num n)
    MoveJ Offs(pPick,0,(n-1)*125,100),v800,z20,tGripper\WObj:=wobjPallet;
    MoveL Offs(pPick,0,(n-1)*125,0),v200,fine,tGripper\WObj:=wobjPallet;
    Set doVacuum;
    WaitTime\InPos,0.2;
    WaitUntil diVacuum=1\MaxTime:=2\TimeFlag:=bBusy;
    MoveL Offs(pPick,0,(n-1)*125,100),v400,z20,tGripper\WObj:=wobjPallet;
  ENDPROC
  PROC PlaceCrate(num n,num layer\switch slow)
    VAR speeddata vPlace:=[300,500,5000,1000];
    IF Present(slow) THEN
      vPlace.v_tcp:=100;
    ENDIF
    MoveL RelTool(pPlace,0,0,-50\Rz:=5),vPlace,z5,tGripper\WObj:=wobjConv;
    MoveL pPlace,vPlace,fine,tGripper\WObj:=wobjConv;
    Reset doVacuum;
    PulseDO\PLength:=0.1,doBlow;
    WaitTime 0.15;
  ENDPROC
ENDMODULE
