! RAPID Kernel, RETURN: leaves the routine from anywhere; a function takes its value along.
MODULE return_statement
  PROC main()
    TPWrite ValToStr(first_above(2));   ! -> 5
    leave;
    RETURN;
    TPWrite "never";                    ! warning: F401
  ENDPROC

  FUNC num first_above(num limit)
    CONST num list{4}:=[1,2,5,7];
    FOR i FROM 1 TO 4 DO
      IF list{i}>limit THEN
        RETURN list{i};
      ENDIF
    ENDFOR
    RETURN 0;
  ENDFUNC

  PROC leave()
    WHILE TRUE DO
      IF TRUE RETURN;
    ENDWHILE
  ENDPROC
ENDMODULE
