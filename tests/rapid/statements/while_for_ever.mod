! RAPID Kernel, WHILE: a loop without an end; in a simulation virtual time passes and ends it.
MODULE while_for_ever
  VAR num turns;

  PROC main()
    TPWrite "begin";                  ! -> begin
    WHILE TRUE DO                     ! ends: time_limit
      WaitTime 1;                     ! note: R109
    ENDWHILE
  ENDPROC
ENDMODULE
