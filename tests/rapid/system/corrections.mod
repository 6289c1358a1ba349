! RAPID Instructions, CorrWrite: what all generators correct is their sum.
MODULE corrections
  VAR corrdescr height;
  VAR corrdescr side;

  PROC main()
    CorrCon height;
    CorrCon side;
    CorrWrite height,[0,0,3];
    CorrWrite side,[0,2,1];
    TPWrite ValToStr(CorrRead());           ! -> [0,2,4]
    CorrDiscon height;
    TPWrite ValToStr(CorrRead());           ! -> [0,2,1]
    CorrClear;
    TPWrite ValToStr(CorrRead());
    TPWrite "none";                         ! -> none
  ERROR
    TPWrite ValToStr(ERRNO=CORR_NOOBJECT);  ! -> TRUE
    TRYNEXT;
  ENDPROC
ENDMODULE
