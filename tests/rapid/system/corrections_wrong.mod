! RAPID Instructions, CorrCon: five generators at a time, and none works unless it is connected.
MODULE corrections_wrong
  VAR corrdescr some{6};

  PROC main()
    CorrWrite some{1},[0,0,1];
    FOR i FROM 1 TO 6 DO
      CorrCon some{i};
    ENDFOR
    CorrDiscon some{6};
  ERROR
    TPWrite ValToStr(ERRNO=CORR_NOTCONN)+ValToStr(ERRNO=CORR_NOFREE); ! -> TRUEFALSE ! -> FALSETRUE ! -> TRUEFALSE
    TRYNEXT;
  ENDPROC
ENDMODULE
