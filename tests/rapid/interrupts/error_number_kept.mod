! RAPID Overview, Interrupts: a trap leaves the program as it was.
MODULE error_number_kept
  VAR intnum tick;
  VAR num zero;

  PROC main()
    CONNECT tick WITH on_tick;
    ITimer\Single,1,tick;
    RAISE 7;
    TPWrite "end";                      ! -> end
  ERROR
    WaitTime 2;
    TPWrite "still "\Num:=ERRNO;        ! -> still 7
    TRYNEXT;
  ENDPROC

  TRAP on_tick
    zero:=1/zero;
    TPWrite "trapped";                  ! -> trapped
  ERROR
    TRYNEXT;
  ENDTRAP
ENDMODULE
