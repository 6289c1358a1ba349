%%%
  VERSION:1
  LANGUAGE:ENGLISH
%%%
MODULE every_construct(SYSMODULE,NOSTEPIN,READONLY)
  ! Every construct of the language at least once.
  RECORD part
    num number;
    string name;
    pos size;
  ENDRECORD
  LOCAL RECORD pair
    part first;
    part second;
  ENDRECORD
  ALIAS num length;
  LOCAL ALIAS string label;

  CONST num PI_HALF:=1.5707963;
  CONST string GREETING:="say ""hello"" \\ \0D\0A";
  TASK PERS tooldata tGrip:=[TRUE,[[0,0,120.5],[1,0,0,0]],[1.5,[0,0,40],[1,0,0,0],0,0,0]];
  PERS wobjdata wTable := [FALSE, TRUE, "", [[600,-200,0],[1,0,0,0]], [[0,0,0],[0.7071068,0,0,0.7071068]]];
  LOCAL VAR num counts{2,3,4};
  VAR bool flags{3}:=[TRUE,FALSE,TRUE];
  VAR num mask:=0xFF;
  VAR num odd:=0b101;
  VAR dnum large:=9E+09;
  VAR robtarget pHere;
  VAR intnum timer;
  LOCAL PERS num kept:=.5;
  CONST jointtarget jHome:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR pos corners{2}:=[[1,2,3],
                       [4,5,6]]; ! several lines

  PROC main()
    VAR num i;
    VAR part p;

    i:=1;
    p.size.x:=counts{1,2,i+1}*-2;
    wTable.oframe.trans.z := 10.;
    flags{i}:=NOT flags{2} AND i>3 OR (i<=5 XOR p.name<>"x");
    p:=[i,"it",[1,2,3]];
    Stop;
    P (i)+(2);
    P -1;
    P NOT flags{1};
    MoveAbsJ jHome\NoEOffs,v1000,fine,tool0;
    MoveL Offs(pHere,0,0,50),v200,z10,tGrip\WObj:=wTable;
    MoveL [[600,0,400],[0.7071068,0,0.7071068,0],[0,-1,0,1],[9E9,9E9,9E9,9E9,9E9,9E9]],
      v200\V:=150, z10, tGrip
      \WObj:=wTable;
    MoveC *,*,v100,fine,tool0;
    TPWrite "at "+ValToStr(CPos(\Tool:=tGrip\WObj:=wTable));
    named Par:=3, 4, Other:=i;
    show\Fast?Present,1;
    %"job"+NumToStr(i,0)%;
    %":job"% i, 2\Fast;

    IF i=1 Stop;
    IF i=2 i:=3;
    IF i>3 %"late"%;
    IF i=1 THEN
      Stop;
    ELSEIF i=2 THEN
      Stop;
      IF TRUE THEN
        Stop;
      ENDIF
    ELSE
      FOR k FROM 1 TO 10 DO
        Incr i;
      ENDFOR
      FOR k FROM 10 TO 1 STEP -2 DO
      ENDFOR
    ENDIF
    WHILE i<10 AND NOT (i=7) DO
      i:=i+1 MOD 3 DIV 2/4;
    ENDWHILE
    again:
    TEST i
    CASE 1,2:
      Stop;
    CASE 3:
    DEFAULT:
      GOTO again;
    ENDTEST
    CONNECT timer WITH Tick;
    CONNECT timer WITH %"Tick"%;
    IF i=<EXP> <SMT>
    <SMT>
    RAISE 5;
    EXIT;
  BACKWARD
    Stop;
  ERROR (LONG_JMP_ALL_ERR)
    IF ERRNO=ERR_DIVZERO TRYNEXT;
    IF ERRNO=ERR_WAIT_MAXTIME THEN
      RETRY;
    ENDIF
    RAISE;
  UNDO
    Reset doGrip;
  ENDPROC

  LOCAL PROC show(\switch Fast | switch Slow, VAR num a{*}, INOUT num b\PERS wobjdata w, num c{*,*})
  ENDPROC

  FUNC num half(num x\num y)
    IF Present(y) RETURN y/2;
    RETURN x/2;
  ERROR
    RETURN 0;
  ENDFUNC

  TRAP Tick
    Write logfile,"X;"\num:=x;
    RETURN;
  ENDTRAP
ENDMODULE
MODULE second_of_two
ENDMODULE
