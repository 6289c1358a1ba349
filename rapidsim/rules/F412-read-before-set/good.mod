MODULE example
  PROC main()
    VAR robtarget p10;
    p10:=CRobT();
    MoveJ p10,v500,fine,tool0;
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  VAR robtarget here;
  VAR num sizes{3};
  VAR string text;
  VAR num value;
  VAR clock watch;
  PROC main()
    VAR bool ok;
    VAR pos place;
    here:=CRobT();
    sizes{1}:=3;
    ok:=StrToVal("3",value);
    fill text;
    place.x:=here.trans.x;
    ClkReset watch;
    ClkStart watch;
    IF ok AND place.x>value TPWrite text+NumToStr(sizes{2},0);
  ENDPROC
  PROC fill(INOUT string s)
    s:="filled";
  ENDPROC
ENDMODULE
