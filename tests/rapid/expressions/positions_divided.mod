! RAPID Kernel, expressions: a position divided by a number is divided in each component.
MODULE positions_divided
  PROC main()
    VAR pos p:=[3,6,-9];
    TPWrite ValToStr(p/3);                  ! -> [1,2,-3]
    TPWrite ValToStr((p+p)/2=p);            ! -> TRUE
    TPWrite ValToStr(p/(p.x-3));
  ERROR
    TPWrite ValToStr(ERRNO=ERR_DIVZERO);    ! -> TRUE
    TRYNEXT;
  ENDPROC
ENDMODULE
