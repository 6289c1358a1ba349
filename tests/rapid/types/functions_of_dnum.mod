! RAPID Functions, BitNegDnum: numbers of double length have functions of their own, to 52 bits.
MODULE functions_of_dnum
  PROC main()
    VAR dnum bits:=0;
    BitSet bits,52;
    TPWrite DnumToStr(bits,0);              ! -> 2251799813685248
    BitClear bits,52;
    TPWrite DnumToStr(BitNegDnum(bits),0);  ! -> 4503599627370495
    TPWrite ""\Dnum:=BitOrDnum(4294901760,65535); ! -> 4294967295
    TPWrite ""\Dnum:=BitXOrDnum(4294967295,1); ! -> 4294967294
    TPWrite ""\Dnum:=ACosDnum(0.5);         ! -> 60
    TPWrite ""\Dnum:=ATan2Dnum(1,1);        ! -> 45
    TPWrite ""\Dnum:=SinDnum(30);           ! -> 0.5
    TPWrite ""\Dnum:=CosDnum(60);           ! -> 0.5
    TPWrite ""\Dnum:=RoundDnum(TanDnum(45)\Dec:=6); ! -> 1
    TPWrite ""\Dnum:=ASinDnum(1);           ! -> 90
    TPWrite ""\Dnum:=ATanDnum(1);           ! -> 45
    TPWrite ""\Num:=Round(Tan(45)\Dec:=5);  ! -> 1
    TPWrite ""\Num:=ATan(1);                ! -> 45
    TPWrite ""\Dnum:=TruncDnum(4294967295.6); ! -> 4294967295
    TPWrite ""\Dnum:=4294967295 MOD 10;     ! -> 5
  ENDPROC
ENDMODULE
