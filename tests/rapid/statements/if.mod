! RAPID Kernel, IF: the first condition that holds decides.
MODULE if_statement
  PROC main()
    FOR i FROM 0 TO 3 DO
      size i;
    ENDFOR
    IF FALSE THEN
    ENDIF
    IF 1=1 THEN TPWrite "on one line"; ENDIF    ! -> on one line
  ENDPROC

  PROC size(num n)
    IF n>2 THEN
      TPWrite "large";            ! -> large
    ELSEIF n>1 THEN
      TPWrite "medium";           ! -> medium
    ELSEIF n>0 THEN
      TPWrite "small";            ! -> small
    ELSE
      TPWrite "none";             ! -> none
    ENDIF
  ENDPROC
ENDMODULE
