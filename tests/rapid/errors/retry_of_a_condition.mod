! RAPID Overview, Error recovery: RETRY evaluates the condition of an IF again.
MODULE retry_of_a_condition
  VAR num divisor;

  PROC main()
    IF 10/divisor>2 THEN
      TPWrite "more than two";          ! -> more than two
    ELSE
      TPWrite "never";
    ENDIF
  ERROR
    divisor:=4;
    RETRY;
  ENDPROC
ENDMODULE
