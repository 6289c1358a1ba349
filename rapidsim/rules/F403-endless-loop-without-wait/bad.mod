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
