MODULE menu
  ! The operator presses keys until one says to leave.
  PROC main()
    VAR num key;
    VAR num parts;
    WHILE key<>3 DO
      TPReadFK key,"What now?","Part","Home","Leave",stEmpty,stEmpty;
      TEST key
      CASE 1:
        TPReadNum parts,"How many?";
        TPWrite "parts: "\Num:=parts;
      CASE 2:
        WaitTime 1;
        TPWrite "home";
      ENDTEST
    ENDWHILE
  ENDPROC
ENDMODULE
