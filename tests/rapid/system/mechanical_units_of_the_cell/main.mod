! RAPID Functions, GetNextMechUnit: units of external axes come behind the robot.
MODULE mechanical_units_of_the_cell
  PROC main()
    VAR num list;
    VAR string name;
    VAR num axes;
    VAR bool robot;
    WHILE GetNextMechUnit(list,name\TCPRob:=robot\NoOfAxes:=axes) DO
      TPWrite name+" "+ValToStr(axes)+" "+ValToStr(robot); ! -> ROB_1 6 TRUE ! -> TABLE 1 FALSE
    ENDWHILE
    DeactUnit TABLE;
    list:=1;
    TPWrite ValToStr(is_active(list));      ! -> FALSE
  ENDPROC

  FUNC bool is_active(num list)
    VAR string name;
    VAR bool on;
    VAR bool found;
    VAR num next;
    next:=list;
    found:=GetNextMechUnit(next,name\Active:=on);
    RETURN on;
  ENDFUNC
ENDMODULE
