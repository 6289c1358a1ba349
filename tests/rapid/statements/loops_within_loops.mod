! RAPID Kernel, GOTO: leaves loops, tests and conditions, however deep, and begins them anew.
MODULE loops_within_loops
  VAR string seen;
  VAR num round_of;

  PROC main()
    anew:
    round_of:=round_of+1;
    FOR i FROM 1 TO 3 DO
      WHILE TRUE DO
        TEST i
        CASE 1:
          GOTO next_one;
        CASE 2:
          IF round_of=1 THEN
            GOTO anew;
          ELSE
            GOTO next_one;
          ENDIF
        DEFAULT:
          GOTO out;
        ENDTEST
      ENDWHILE
      next_one:
      seen:=seen+" "+ValToStr(i);
    ENDFOR
    out:
    TPWrite "seen"+seen;                  ! -> seen 1 1 2
  ENDPROC
ENDMODULE
