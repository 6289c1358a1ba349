! RAPID Instructions, CirPathMode: two wrist axes lead the z axis of the tool, all others stand.
MODULE wrist_circle
  PERS tooldata nozzle:=[TRUE,[[40,0,180],[0.9914449,0,0.1305262,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];
  VAR robtarget start;
  VAR robtarget half;
  VAR robtarget here;

  ! The numbers were found by a plain search that knows the forward kinematics and nothing else.
  PROC main()
    CirPathMode \Wrist45;
    cut 20;
    CirPathMode \Wrist46;
    cut 80;
    CirPathMode \Wrist56;
    cut 20;
  ENDPROC

  PROC cut(num axis_6)
    VAR jointtarget ready:=[[10,-10,20,10,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    ready.robax.rax_6:=axis_6;
    MoveAbsJ ready,v500,fine,nozzle;
    start:=CRobT(\Tool:=nozzle\WObj:=wobj0);
    half:=RelTool(start,10,0,0);
    ! A hole of 10 mm across, in the plane that the nozzle is perpendicular to.
    MoveC RelTool(start,5,5,0),half,v20,fine,nozzle;  ! note: K618
    tell;
    here:=CRobT(\Tool:=nozzle\WObj:=wobj0);
    TPWrite NumToStr(Distance(here.trans,half.trans),2)+" mm from the end";
    ! -> 0.80 mm from the end
    ! -> 0.80 mm from the end
    ! -> 0.80 mm from the end
    MoveC RelTool(start,5,-5,0),start,v20,fine,nozzle;  ! note: K618
    tell;
  ENDPROC

  PROC tell()
    VAR robjoint now;
    VAR jointtarget all;
    VAR string arm;
    VAR string wrist;
    all:=CJointT();
    now:=all.robax;
    arm:=NumToStr(now.rax_1,1)+" "+NumToStr(now.rax_2,1)+" "+NumToStr(now.rax_3,1);
    wrist:=NumToStr(now.rax_4,2)+" "+NumToStr(now.rax_5,2)+" "+NumToStr(now.rax_6,2);
    TPWrite arm+" / "+wrist;
    ! -> 10.0 -10.0 20.0 / 10.83 62.21 20.00
    ! -> 10.0 -10.0 20.0 / 10.00 60.00 20.00
    ! -> 10.0 -10.0 20.0 / 12.74 60.00 75.94
    ! -> 10.0 -10.0 20.0 / 10.00 60.00 80.00
    ! -> 10.0 -10.0 20.0 / 10.00 62.51 25.27
    ! -> 10.0 -10.0 20.0 / 10.00 60.00 20.00
  ENDPROC
ENDMODULE
