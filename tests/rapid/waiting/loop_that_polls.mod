! Field practice, Polling: a loop without a wait looks until a trap has changed what it looks at.
MODULE loop_that_polls
  VAR intnum tick;
  VAR num ticks;
  VAR clock watch;

  PROC main()
    CONNECT tick WITH on_tick;
    ITimer 10,tick;
    ClkStart watch;
    WHILE ticks<3 DO
    ENDWHILE
    TPWrite "after "\Num:=Round(ClkRead(watch)); ! -> after 30
    ! Nothing can change what this one looks at.
    IDelete tick;
    WHILE ticks<4 DO                    ! stops: the program loops forever here: nothing that it reads ever changes
    ENDWHILE
  ENDPROC

  TRAP on_tick
    Incr ticks;
  ENDTRAP
ENDMODULE
