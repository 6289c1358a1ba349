MODULE example
  VAR num count;
  PROC main()
    WHILE TRUE DO ! found
      count:=count+1;
    ENDWHILE
  ENDPROC
ENDMODULE
! ---
MODULE bad
  VAR num count;
  VAR signaldo lamp;
  PROC main()
    WHILE TRUE DO                     ! found
      count:=count+Sin(count);
      IF count>3 THEN
        SetDO lamp,1;
        TPWrite "busy";
        PulseDO lamp;
        ErrWrite "Busy","and nobody waits";
      ENDIF
    ENDWHILE
  ENDPROC
  PROC other()
    WHILE NOT FALSE DO                ! found
    ENDWHILE
  ENDPROC
ENDMODULE
! ---
MODULE jumps
  VAR num count;
  PROC main()
    again:
    count:=count+1;
    IF count>3 THEN
      inner:
      count:=0;
      GOTO inner; ! found
    ENDIF
    GOTO again;
  ENDPROC
  PROC other()
    again:
    Incr count;
    GOTO again; ! found
  ENDPROC
ENDMODULE
