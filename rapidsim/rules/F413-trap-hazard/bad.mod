MODULE example
  VAR intnum part_seen;
  PROC main()
    FOR i FROM 1 TO 3 DO
      CONNECT part_seen WITH count; ! found
      ITimer 1,part_seen;
      WaitTime 2;
    ENDFOR
  ENDPROC
  TRAP count
    TPWrite "part";
  ENDTRAP
ENDMODULE
! ---
MODULE bad
  VAR intnum part_seen;
  VAR signaldi free;
  VAR socketdev line;
  VAR string answer;
  PROC main()
    WHILE TRUE DO
      FOR i FROM 1 TO 3 DO
        CONNECT part_seen WITH count; ! found
        ITimer 1,part_seen;
        WaitTime 2;
      ENDFOR
    ENDWHILE
  ENDPROC
  TRAP count
    WaitDI free,1;                    ! found
    IF INTNO>0 WaitTime 1;            ! found
    SocketReceive line\Str:=answer;   ! found
    answer:=UIAlphaEntry(\Header:="Name"\Message:="Who?"\InitString:="nobody"); ! found
  ENDTRAP
ENDMODULE
