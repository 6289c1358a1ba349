MODULE constant_that_is_no_number
  ! Infinite less infinite is not a number, and neither is what DIV and MOD make of it.
  CONST num huge:=1E38*1E38*1E38*1E38*1E38*1E38*1E38*1E38*1E38;
  CONST num rest:=(huge-huge) MOD 2;
  CONST num half:=(huge-huge) DIV 2;
  PROC main()
    VAR num list{3}:=[1,2,3];
    IF rest>0 TPWrite "rest";
    FOR i FROM 1 TO half DO
      TPWrite NumToStr(list{rest},0);
    ENDFOR
  ENDPROC
ENDMODULE
