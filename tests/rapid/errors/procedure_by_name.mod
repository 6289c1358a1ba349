! RAPID Overview, Error recovery: a procedure that is called by a name nobody has is ERR_REFUNKPRC.
MODULE procedure_by_name
  VAR num number:=9;

  PROC main()
    %"part"+ValToStr(number)%;
  ERROR
    IF ERRNO=ERR_REFUNKPRC THEN
      TPWrite "no part "\Num:=number;   ! -> no part 9
      number:=1;
      RETRY;
    ENDIF
  ENDPROC

  PROC part1()
    TPWrite "part 1";                   ! -> part 1
  ENDPROC
ENDMODULE
