! RAPID Instructions, SetSysData: a tool, a work object or a load becomes the active one.
MODULE active_tool
  CONST jointtarget home:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PERS tooldata tGun:=[TRUE,[[0,0,100],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];
  PERS wobjdata wTable:=[FALSE,TRUE,"",[[0,0,0],[1,0,0,0]],[[700,0,0],[1,0,0,0]]];
  PERS loaddata part:=[2,[0,0,50],[1,0,0,0],0,0,0];
  PERS tooldata tNow:=[TRUE,[[0,0,0],[1,0,0,0]],[0,[0,0,0],[1,0,0,0],0,0,0]];
  PERS wobjdata wNow:=[FALSE,TRUE,"",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  PERS loaddata lNow:=[0,[0,0,0],[1,0,0,0],0,0,0];
  PERS num none:=0;

  PROC main()
    VAR string name;
    GetSysData tNow\ObjectName:=name;
    TPWrite name;                           ! -> tool0
    MoveAbsJ home,v500,fine,tGun\WObj:=wTable;
    GetSysData tNow\ObjectName:=name;
    TPWrite name+ValToStr(tNow.tframe.trans); ! -> tGun[0,0,100]
    GetSysData wNow\ObjectName:=name;
    TPWrite name+ValToStr(wNow.oframe.trans); ! -> wTable[700,0,0]
    SetSysData tool0;
    SetSysData wobj0\ObjectName:="wobj0";
    TPWrite ValToStr(CTool()=tool0);        ! -> TRUE
    TPWrite ValToStr(CWObj()=wobj0);        ! -> TRUE
    SetSysData tool0\ObjectName:="tGun";
    GetSysData tNow\ObjectName:=name;
    TPWrite name+ValToStr(tNow.tframe.trans); ! -> tGun[0,0,100]
    MoveAbsJ home,v500,fine,tNow;
    SetSysData tGun\ObjectName:="tool0";
    TPWrite ValToStr(CTool()=tool0);        ! -> TRUE
    SetSysData part;
    GetSysData lNow\ObjectName:=name;
    TPWrite name+ValToStr(lNow.mass);       ! -> part2
    GripLoad load0;
    GetSysData lNow\ObjectName:=name;
    TPWrite name;                           ! -> load0
    SetSysData none;
    TPWrite "behind";                       ! -> behind
  ERROR
    TPWrite ValToStr(ERRNO=ERR_ARGVALERR);  ! -> TRUE
    TRYNEXT;
  ENDPROC
ENDMODULE
