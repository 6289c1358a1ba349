  PROC main()
    MoveJ p10,v500,fine,gripper;
    MoveL p20,v300,z5,gripper; ! M502
    close_it;
  ENDPROC
  PROC close_it()
    SetDO grip,1;
    WaitDI gripped,1\MaxTime:=2;
  ENDPROC
! ---
  PROC main()
    MoveJ p10,v500,fine,gripper;
    MoveL p20,v300,z5,gripper;
    open_it; ! M503
    MoveL p10,v300,fine,gripper;
  ENDPROC
  PROC open_it()
    Reset grip;
  ENDPROC
! ---
  PROC main()
    MoveJ p10,v500,fine,gripper;
    MoveL p20,v300,z5,gripper; ! M502
    outer;
  ENDPROC
  PROC outer()
    inner;
  ENDPROC
  PROC inner()
    WaitTime 0.5;
  ENDPROC
! ---
  PROC main()
    approach;
    WaitTime 0.5; ! M502
  ENDPROC
  PROC approach()
    MoveJ p10,v500,z20,gripper;
  ENDPROC
! ---
  PROC main()
    MoveJ p10,v500,fine,gripper;
    WHILE TRUE DO
      WaitDI gripped,1\MaxTime:=9;
      MoveL p20,v300,fine,gripper;
      MoveL p10,v300,z10,gripper; ! M502
    ENDWHILE
  ENDPROC
! ---
  PROC main()
    MoveJ p10,v500,fine,gripper;
    MoveL p20,v300,z10,gripper; ! M502
    IF answer()>2 MoveL p10,v300,fine,gripper;
  ENDPROC
  FUNC num answer()
    WaitTime 0.1;
    RETURN 3;
  ENDFUNC
! ---
  PROC main()
    IF NOT done AND count>3 WaitTime 1; ! F417
    done:=count>2;
    Incr count;
  ENDPROC
! ---
  PROC main()
    WaitUntil NOT done AND count>3\MaxTime:=9; ! F417
    done:=TRUE;
    Incr count;
  ENDPROC
! ---
  PROC main()
    count:=1;
    WHILE count<=3 DO ! F418
      WaitTime 1;
    ENDWHILE
  ENDPROC
! ---
  PROC main()
    done:=FALSE;
    WHILE NOT done DO ! F418
      WaitTime 0.1;
      look;
    ENDWHILE
  ENDPROC
  PROC look()
    count:=count+1;
  ENDPROC
! ---
  PROC main()
    done:=FALSE;
    WaitUntil done; ! F418
  ENDPROC
! ---
  PROC main()
    countdown 3;
  ENDPROC
  PROC countdown(num n)
    VAR num left;
    left:=n;
    WHILE left>0 DO ! F418
      n:=n-1;
      WaitTime 1;
    ENDWHILE
  ENDPROC
! ---
  PROC main()
    IDisable; ! F422
    count:=count+1;
    IF count>3 RETURN;
    IEnable;
  ENDPROC
! ---
  PROC main()
    IDisable; ! F422
    count:=count+1;
  ENDPROC
! ---
  PROC main()
    add_one;
  ENDPROC
  PROC add_one()
    IDisable; ! F422
    TEST count
    CASE 1:
      IEnable;
    CASE 2:
      IEnable;
    ENDTEST
    Incr count;
  ENDPROC
! ---
  PROC main()
    CONNECT pressed WITH hold;
    ISignalDI gripped,1,pressed;
    WaitTime 9;
  ENDPROC
  TRAP hold
    StopMove; ! F420
    IF done RETURN;
    StartMove;
  ENDTRAP
! ---
  PROC main()
    CONNECT pressed WITH hold;
    ISignalDI gripped,1,pressed;
    done:=TRUE;
    WaitTime 9;
  ENDPROC
  TRAP hold
    StopMove\Quick; ! F420
    IF done THEN
      TPWrite "held";
    ELSE
      StartMove;
    ENDIF
  ENDTRAP
! ---
  PROC main()
    CONNECT pressed WITH hold;
    ISignalDI gripped,1,pressed;
    WaitTime 9;
  ENDPROC
  TRAP hold
    StopMove; ! F420
    TPWrite "held";
  ENDTRAP
! ---
  PROC main()
    FOR i FROM 1 TO 11 DO
      heights{i}:=i; ! T325
    ENDFOR
  ENDPROC
! ---
  PROC main()
    FOR i FROM 0 TO 9 DO
      heights{i}:=i; ! T325
    ENDFOR
  ENDPROC
! ---
  PROC main()
    FOR i FROM 1 TO Dim(heights,1) DO
      heights{i}:=heights{i+1}; ! T325
    ENDFOR
  ENDPROC
! ---
  PROC main()
    count:=1;
    WHILE count<=11 DO
      heights{count}:=5; ! T325
      Incr count;
    ENDWHILE
  ENDPROC
! ---
  PROC main()
    FOR i FROM 10 TO 1 DO
      heights{i}:=heights{i-1}; ! T325
    ENDFOR
  ENDPROC
! ---
  PROC main()
    TPWrite "The gripper has not reported that it is closed, "+"so the part may still lie where it lay before"; ! T326
  ENDPROC
! ---
  CONST string head:="Robot 1, station 4, left hand side, door beside the press: ";
  PROC main()
    say "open";
  ENDPROC
  PROC say(string text)
    TPWrite head+"this has happened there: "+text; ! T326
  ENDPROC
! ---
  PROC main()
    FOR i FROM 1 TO 3 DO
      Open "HOME:"\File:="log.txt",log\Append; ! F421
      Write log,"part";
    ENDFOR
  ENDPROC
! ---
  PROC main()
    WHILE TRUE DO
      write_line; ! F421
      WaitTime 1;
    ENDWHILE
  ENDPROC
  PROC write_line()
    Open "HOME:"\File:="log.txt",log\Append;
    Write log,"part";
  ENDPROC
! ---
  VAR triggdata glue_on;
  PROC main()
    MoveJ p10,v500,fine,gripper;
    TriggL p20,v100,glue_on,fine,gripper; ! F412
  ENDPROC
! ---
  VAR triggdata glue_on;
  VAR triggdata glue_off;
  PROC main()
    MoveJ p10,v500,fine,gripper;
    TriggIO glue_on,5\DOp:=grip,1;
    TriggL p20,v100,glue_on\T2:=glue_off,fine,gripper; ! F412
  ENDPROC
! ---
  CONST robtarget p_metres:=[[0.6,0.1,0.7],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ p_metres,v500,fine,gripper; ! M516
  ENDPROC
! ---
  PERS tooldata pen:=[TRUE,[[0,0,0.115],[1,0,0,0]],[1,[0,0,60],[1,0,0,0],0,0,0]]; ! M516
  PROC main()
    MoveJ p10,v500,fine,pen;
  ENDPROC
! ---
  PROC main()
    MoveJ RelTool(p10,0,0,0\Rx:=1.5708),v500,fine,gripper; ! M516
  ENDPROC
! ---
  PROC main()
    MoveJ RelTool(p10,0,0,0\Rz:=pi/4),v500,fine,gripper; ! M516
  ENDPROC
! ---
  PROC main()
    FOR i FROM 1 TO 6 DO
      MoveJ Offs(p10,100*Cos(i*pi/3),0,0),v500,fine,gripper; ! M516
    ENDFOR
  ENDPROC
! ---
  CONST jointtarget bent:=[[0,0.785,-0.5236,0,1.5708,0],[9E9,9E9,9E9,9E9,9E9,9E9]]; ! M516
  PROC main()
    MoveAbsJ bent,v500,fine,gripper;
  ENDPROC
! ---
  PERS robtarget p_next:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ p_next,v500,fine,gripper;
    p_next:=Offs(p_next,0,50,0); ! M517
  ENDPROC
! ---
  PERS robtarget p_next:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    FOR i FROM 1 TO 3 DO
      p_next:=RelTool(p_next,0,0,-10); ! M517
      MoveJ p_next,v500,fine,gripper;
    ENDFOR
  ENDPROC
! ---
  PROC main()
    MoveJ p10,v500,fine,gripper;
    MoveL Offs(p10,0,0,50),v500,fine,tool0; ! M507
  ENDPROC
! ---
  PROC main()
    MoveJ p10,v500,fine,gripper\WObj:=table;
    MoveL RelTool(p10,0,0,-50),v500,fine,gripper; ! M507
  ENDPROC
! ---
  PROC main()
    VAR wztemporary beside; ! N217
    VAR shapedata box;
    WZBoxDef\Inside,box,[300,300,0],[400,400,600];
    WZLimSup\Temp,beside,box;
  ENDPROC
