! RAPID Instructions, TriggIO, TriggEquip, TriggInt: outputs and interrupts at places of the path.
MODULE places_on_the_way
  CONST robtarget p1:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR triggdata on;
  VAR triggdata copied;
  VAR triggdata off;
  VAR triggdata here;
  VAR intnum flank;
  VAR intnum passed;

  PROC main()
    MoveJ p1,v500,fine,tool0;
    CONNECT flank WITH tell;
    ISignalDO doGlue,edge,flank;
    CONNECT passed WITH tell;
    TriggIO on,100\Start\DOp:=doGlue,1;
    TriggEquip off,20,0.1\DOp:=doGlue,0;
    TriggInt here,50,passed;
    TriggDataCopy on,copied;
    TriggDataReset on;
    TPWrite ValToStr(TriggDataValid(on))+ValToStr(TriggDataValid(copied));    ! -> FALSETRUE
    TriggL Offs(p1,0,200,0),v100,copied\T2:=off\T3:=here,fine,tool0;
  ENDPROC

  TRAP tell
    VAR pos now;
    now:=CPos(\Tool:=tool0);
    TPWrite ValToStr(DOutput(doGlue))+" at "\Num:=Round(now.y);    ! -> 1 at 100 ! -> 1 at 150 ! -> 0 at 170
  ENDTRAP
ENDMODULE
