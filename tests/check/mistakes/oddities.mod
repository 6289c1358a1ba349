  PROC main()
    MoveJ p10,v500,z20,gripper;
    move_on;
    WaitTime 1;
  ENDPROC
  PROC move_on()
    MoveL p20,v300,fine,gripper;
  ENDPROC
! ---
  PROC main()
    MoveJ p10,v500,z20,gripper;
    IF count<0 fault;
    MoveL p20,v300,fine,gripper;
    Incr count;
  ENDPROC
  PROC fault()
    Stop;
  ENDPROC
! ---
  PROC main()
    MoveJ p10,v500,z20,gripper;
    TPWrite "on the way";
    count:=count+1;
    MoveL p20,v300,fine,gripper;
  ENDPROC
! ---
  PROC main()
    MoveJ p10,v500,z20,gripper;
    MoveLDO p20,v300,z10,gripper,grip,1;
    MoveL p10,v300,fine,gripper;
  ENDPROC
! ---
  PROC main()
    MoveJ p10,v500,fine,gripper;
    open_it;
    WaitTime 1;
  ENDPROC
  PROC open_it()
    Reset grip;
  ENDPROC
! ---
  PROC main()
    prepare;
    MoveL p20,v300,fine,gripper;
  ENDPROC
  PROC prepare()
    AccSet 50,50;
    ConfL\Off;
    MoveAbsJ home,v500,fine,gripper;
  ENDPROC
! ---
  PROC main()
    prepare;
    WHILE TRUE DO
      MoveJ p20,v300,fine,gripper;
    ENDWHILE
  ENDPROC
  PROC prepare()
    VelSet 50,1000;
    SingArea\Wrist;
    MoveAbsJ home,v500,fine,gripper;
  ENDPROC
! ---
  PROC main()
    slow;
    MoveJ p10,v500,fine,gripper;
  ENDPROC
  PROC slow()
    VelSet 50,1000;
  ENDPROC
! ---
  PROC main()
    CONNECT pressed WITH hold;
    ISignalDI gripped,1,pressed;
    WaitTime 9;
  ENDPROC
  TRAP hold
    StopMove;
    WaitDI gripped,0\MaxTime:=60;
    StartMove;
  ENDTRAP
! ---
  PROC main()
    CONNECT pressed WITH hold;
    ISignalDI gripped,1,pressed;
    WaitTime 9;
  ENDPROC
  TRAP hold
    StopMove;
    StorePath;
    WaitTime 2;
    RestoPath;
    StartMove;
  ENDTRAP
! ---
  PROC main()
    CONNECT pressed WITH hold;
    ISignalDI gripped,1,pressed;
    WaitUntil done\MaxTime:=9;
    ClearPath;
    StartMove;
  ENDPROC
  TRAP hold
    StopMove;
    done:=TRUE;
  ENDTRAP
! ---
  PROC main()
    IF count>2 AND NOT (done OR count=7) Incr count;
    done:=count>3;
  ENDPROC
! ---
  PROC main()
    IF NOT done OR count>3 Incr count;
    done:=count>3;
  ENDPROC
! ---
  PROC main()
    IF (NOT done) AND count>3 Incr count;
    done:=count>3;
  ENDPROC
! ---
  PROC main()
    IF NOT (done AND count>3) Incr count;
    done:=count>3;
  ENDPROC
! ---
  PROC main()
    check_it\limit:=3;
    check_it\limit:=5;
  ENDPROC
  PROC check_it(\num limit)
    IF count>limit Incr count;
  ENDPROC
! ---
  PROC main()
    outer\limit:=3;
    outer;
  ENDPROC
  PROC outer(\num limit)
    IF Present(limit) check_it\limit?limit;
  ENDPROC
  PROC check_it(\num limit)
    IF count>limit Incr count;
  ENDPROC
! ---
  PERS num counts{3}:=[0,0,0];
  PROC main()
    Incr counts{2};
  ENDPROC
! ---
  VAR clock watch;
  PROC main()
    ClkStart watch;
    WaitUntil done OR ClkRead(watch)>5;
    done:=TRUE;
  ENDPROC
! ---
  PROC main()
    count:=1;
    WHILE count<=3 DO
      count:=count+1;
    ENDWHILE
  ENDPROC
! ---
  VAR bool for_ever:=TRUE;
  PROC main()
    WHILE for_ever DO
      MoveJ p10,v500,fine,gripper;
    ENDWHILE
  ENDPROC
! ---
  PROC main()
    CONNECT pressed WITH note_it;
    ISignalDI gripped,1,pressed;
    done:=FALSE;
    WHILE NOT done DO
      WaitTime 0.1;
    ENDWHILE
  ENDPROC
  TRAP note_it
    done:=TRUE;
  ENDTRAP
! ---
  PERS bool go:=FALSE;
  PROC main()
    WHILE go=FALSE DO
      WaitTime 0.1;
    ENDWHILE
    go:=FALSE;
  ENDPROC
! ---
  PROC main()
    WHILE DInput(gripped)=0 DO
      WaitTime 0.1;
    ENDWHILE
  ENDPROC
! ---
  PROC main()
    count:=0;
    WHILE count<9 DO
      advance count;
    ENDWHILE
  ENDPROC
  PROC advance(INOUT num n)
    n:=n+2;
  ENDPROC
! ---
  PROC main()
    count:=0;
    WHILE count<9 DO
      WaitTime 1;
      IF done RETURN;
    ENDWHILE
    done:=TRUE;
  ENDPROC
! ---
  PROC main()
    lock;
    Incr count;
    unlock;
  ENDPROC
  PROC lock()
    IDisable;
  ENDPROC
  PROC unlock()
    IEnable;
  ENDPROC
! ---
  PROC main()
    IDisable;
    IF count>3 THEN
      IEnable;
      RETURN;
    ENDIF
    Incr count;
    IEnable;
  ENDPROC
! ---
  PROC main()
    FOR i FROM 1 TO 11 DO
      IF i<11 heights{i}:=i;
    ENDFOR
  ENDPROC
! ---
  PROC main()
    FOR i FROM 0 TO 9 DO
      heights{i+1}:=i;
    ENDFOR
  ENDPROC
! ---
  PROC main()
    FOR i FROM 1 TO 20 DO
      IF heights{i}=0 RETURN;
    ENDFOR
    heights{1}:=1;
  ENDPROC
! ---
  CONST string dashes:="----------------------------------------";
  PROC main()
    TPWrite dashes+dashes;
  ENDPROC
! ---
  PROC main()
    FOR i FROM 1 TO 3 DO
      Open "HOME:"\File:="log.txt",log\Append;
      Write log,"part";
      finish;
    ENDFOR
  ENDPROC
  PROC finish()
    Close log;
  ENDPROC
! ---
  VAR triggdata glue_on;
  PROC main()
    prepare glue_on;
    MoveJ p10,v500,fine,gripper;
    TriggL p20,v100,glue_on,fine,gripper;
  ENDPROC
  PROC prepare(VAR triggdata trigger)
    TriggIO trigger,5\DOp:=grip,1;
  ENDPROC
! ---
  CONST robtarget corner:=[[0.5,0.25,0],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ corner,v500,fine,gripper\WObj:=table;
  ENDPROC
! ---
  PROC main()
    MoveJ RelTool(p10,0,0,3.14159\Rz:=1.5\Rx:=45),v500,fine,gripper;
    count:=Sin(count*180/pi)+pi*Cos(30);
  ENDPROC
! ---
  PERS robtarget p_next:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    p_next:=p10;
    FOR i FROM 1 TO 3 DO
      MoveJ p_next,v500,fine,gripper;
      p_next:=Offs(p_next,50,0,0);
    ENDFOR
  ENDPROC
! ---
  VAR robtarget p_now;
  PROC main()
    p_now:=CRobT(\Tool:=gripper);
    p_now:=Offs(p_now,0,0,50);
    MoveL p_now,v100,fine,gripper;
  ENDPROC
! ---
  PROC main()
    MoveJ Offs(p10,0,0,100),v500,z50,gripper;
    MoveL p10,v100,fine,gripper;
    MoveL RelTool(Offs(p10,0,0,50),0,0,-50),v500,fine,gripper;
  ENDPROC
! ---
  VAR wztemporary beside;
  PROC main()
    VAR shapedata box;
    WZBoxDef\Inside,box,[300,300,0],[400,400,600];
    WZLimSup\Temp,beside,box;
  ENDPROC
