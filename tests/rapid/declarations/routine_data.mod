! RAPID Kernel, Routine data: made anew at each call; module data stay.
MODULE routine_data
  VAR num calls;

  PROC main()
    count;                        ! routine data come before statements
    count;
  ENDPROC

  PROC count()
    VAR num here:=10;
    CONST num STEP_SIZE:=1;
    VAR num row{2}:=[5,6];
    here:=here+STEP_SIZE;
    row{1}:=row{1}+row{2};
    calls:=calls+1;
    TPWrite ValToStr(calls)+" "+ValToStr(here)+" "+ValToStr(row);
    ! -> 1 11 [11,6]
    ! -> 2 11 [11,6]
  ENDPROC
ENDMODULE
