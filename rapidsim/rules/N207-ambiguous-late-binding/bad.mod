MODULE example
  VAR num part:=1;
  PROC main()
    %"part_"+NumToStr(part,0)%; ! found
  ENDPROC
  PROC part1()
  ENDPROC
ENDMODULE
! ---
MODULE bad
  VAR num part:=1;
  CONST string beginning:="task_";
  PROC main()
    %"part_"+NumToStr(part,0)%;                   ! found
    %NumToStr(part,0)+"_end"%;                    ! found
    %beginning+NumToStr(part,0)%;                 ! found
    %"no_such"%;                                  ! found
  ENDPROC
  PROC part1()
    WaitTime 1;
  ENDPROC
ENDMODULE
