MODULE example
  VAR num part:=1;
  PROC main()
    %"part"+NumToStr(part,0)%;
  ENDPROC
  PROC part1()
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  VAR num part:=2;
  VAR string name:="anything";
  PROC main()
    %"part"+NumToStr(part,0)%;
    %name%;
    %"near_miss:part"+ValToStr(part)%;
    %name+"_of_other_task"+name% 1,2;
  ENDPROC
  PROC part2()
    WaitTime 1;
  ENDPROC
  PROC x_of_other_task_y(num a,num b)
    WaitTime a+b;
  ENDPROC
ENDMODULE
