! RAPID Functions, RobName: a task without a robot has no name for one; GetNextMechUnit: it sees all.
MODULE third
  PROC main()
    VAR num list;
    VAR string name;
    VAR bool robot;
    VAR num owner;
    VAR num planner;
    TPWrite "["+RobName()+"]"\Num:=MotionPlannerNo();    ! -> []0
    WHILE GetNextMechUnit(list,name\TCPRob:=robot\MecTaskNo:=owner\MotPlanNo:=planner) DO
      TPWrite name+" "+ValToStr(robot)+" "+ValToStr(owner)+" "+ValToStr(planner); ! -> ROB_1 TRUE 1 1 ! -> ROB_2 TRUE 2 2
    ENDWHILE
  ENDPROC
ENDMODULE
