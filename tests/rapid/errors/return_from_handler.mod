! RAPID Kernel, Error recovery: RETURN in the ERROR clause ends the routine, with a value in FUNC.
MODULE return_from_handler
  VAR num zero;

  PROC main()
    TPWrite ValToStr(ratio(6,3));       ! -> 2
    TPWrite ValToStr(ratio(6,zero));    ! -> 0
    gives_up;
    TPWrite "after";                    ! -> after
  ENDPROC

  FUNC num ratio(num a,num b)
    RETURN a/b;
  ERROR
    RETURN 0;
  ENDFUNC

  PROC gives_up()
    zero:=1/zero;
    TPWrite "never";
  ERROR
    RETURN;
  ENDPROC
ENDMODULE
