! RAPID Functions, BitAnd and others: bytes have eight bits, a dnum has 52.
MODULE bytes_and_bits
  VAR byte data:=130;
  VAR dnum wide:=2251799813685378;

  PROC main()
    TPWrite ValToStr(BitAnd(38,34))+" "+ValToStr(BitOr(39,162));              ! -> 34 167
    TPWrite ValToStr(BitXOr(39,162))+" "+ValToStr(BitNeg(38));                ! -> 133 217
    TPWrite ValToStr(BitLSh(38,3))+" "+ValToStr(BitRSh(38,3));                ! -> 48 4
    TPWrite ValToStr(BitCheck(data,8))+ValToStr(BitCheckDnum(wide,52));       ! -> TRUETRUE
    BitClear data,8;
    BitSet data,1;
    BitClear wide,52;
    TPWrite ValToStr(data)+" "+ValToStr(wide);                                ! -> 3 130
    BitSet data,9;
  ERROR
    TPWrite ValToStr(ERRNO=ERR_ARGVALERR);                                    ! -> TRUE
    TRYNEXT;
  ENDPROC
ENDMODULE
