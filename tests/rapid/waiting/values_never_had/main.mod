! RAPID Instructions, WaitAI, WaitGI: a value outside the limits of the signal is an error at once.
MODULE values_never_had
  VAR clock waited;

  PROC main()
    ClkStart waited;
    FOR i FROM 1 TO 6 DO
      wait_in_vain i;
    ENDFOR
    TPWrite "after "\Num:=ClkRead(waited);    ! -> after 0
    WaitGI giCode\LT,16\MaxTime:=1;           ! stops: `giCode` cannot be 16: its limits are 0 .. 15 (ERR_GO_LIM)
  ENDPROC

  PROC wait_in_vain(num way)
    TEST way
    CASE 1:
      WaitAI aiFlow\GT,11\MaxTime:=1;
    CASE 2:
      WaitAI aiFlow\LT,-1\MaxTime:=1;
    CASE 3:
      WaitAO aoFlow,20\MaxTime:=1;
    CASE 4:
      WaitGI giCode,16\MaxTime:=1;
    CASE 5:
      WaitGI giCode\NOTEQ,-1\MaxTime:=1;
    CASE 6:
      WaitGO goCode,99\MaxTime:=1;
    ENDTEST
    TPWrite "never";
  ERROR
    TEST ERRNO
    CASE ERR_AO_LIM:
      TPWrite "analog "\Num:=way;
      ! -> analog 1
      ! -> analog 2
      ! -> analog 3
    CASE ERR_GO_LIM:
      TPWrite "group "\Num:=way;
      ! -> group 4
      ! -> group 5
      ! -> group 6
    ENDTEST
    RETURN;
  ENDPROC
ENDMODULE
