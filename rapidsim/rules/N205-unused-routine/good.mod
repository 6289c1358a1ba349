MODULE example
  PROC main()
    WaitTime doubled(1);
  ENDPROC
  FUNC num doubled(num x)
    RETURN 2*x;
  ENDFUNC
ENDMODULE
! ---
MODULE near_miss
  ! A service routine, traps, a recursion, and routines that are called by a name in a string.
  VAR intnum ticked;
  VAR num part:=2;
  PROC main()
    CONNECT ticked WITH tick;
    ITimer 1,ticked;
    %"part"+NumToStr(part,0)%;
    CallByVar "tool",part;
    WaitTime factorial(3)/10;
  ENDPROC
  PROC to_service_position()
    WaitTime 1;
  ENDPROC
  LOCAL PROC part2()
    WaitTime 1;
  ENDPROC
  LOCAL PROC tool2()
    WaitTime 1;
  ENDPROC
  LOCAL FUNC num factorial(num n)
    IF n<=1 RETURN 1;
    RETURN n*factorial(n-1);
  ENDFUNC
  TRAP tick
    TPWrite "tick";
  ENDTRAP
ENDMODULE
