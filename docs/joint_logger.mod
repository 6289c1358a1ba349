MODULE joint_logger
  ! Writes the angles of the axes to a file while another task moves the robot, for
  ! `rapidsim calibrate`. Load it into a task of its own (semi-static, TrustLevel NoSafety) and let
  ! the task that moves set bLogging, which both declare.
  PERS bool bLogging:=FALSE;
  CONST num nPeriod:=0.012;

  PROC main()
    VAR iodev file;
    VAR clock since;
    VAR jointtarget now;

    WaitUntil bLogging;
    Open "HOME:"\File:="joint_log.csv", file\Write;
    Write file, "time,j1,j2,j3,j4,j5,j6";
    ClkReset since;
    ClkStart since;
    WHILE bLogging DO
      now:=CJointT();
      Write file, ValToStr(ClkRead(since))+","+Axes(now.robax);
      WaitTime nPeriod;
    ENDWHILE
    ClkStop since;
    Close file;
  ENDPROC

  FUNC string Axes(robjoint at)
    RETURN ValToStr(at.rax_1)+","+ValToStr(at.rax_2)+","+ValToStr(at.rax_3)+","
      +ValToStr(at.rax_4)+","+ValToStr(at.rax_5)+","+ValToStr(at.rax_6);
  ENDFUNC
ENDMODULE
