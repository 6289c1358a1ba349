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
    empty;
  ENDPROC
  PROC empty()
    VAR num zeros{3};
    VAR string nothing;
    sizes:=zeros;
    text:=nothing;
  ENDPROC
ENDMODULE
! ---
MODULE triggers
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR triggdata glue_on;
  VAR triggdata several{2};
  VAR signaldo glue;
  PROC main()
    define glue_on,1;
    TriggIO several{1},5\DOp:=glue,1;
    MoveJ p10,v500,fine,tool0;
    TriggL p10,v100,glue_on,fine,tool0;
    TriggL p10,v100,several,fine,tool0;
  ENDPROC
  PROC define(VAR triggdata trigger,num value)
    TriggIO trigger,5\DOp:=glue,value;
  ENDPROC
ENDMODULE
