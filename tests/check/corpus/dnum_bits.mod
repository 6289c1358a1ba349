MODULE dnum_bits
  VAR dnum big:=4294967295;
  VAR byte flags:=0;
  VAR num small;
  VAR dnum masks{3}:=[0x01,0x80,0x100];
  PROC main()
    BitSet flags,3;
    flags:=BitOr(flags,BitLSh(1,5));
    IF BitCheck(flags,3) small:=DnumToNum(big DIV 65536\Integer);
    big:=NumToDnum(small)+masks{2};
    small:=Trunc(12.34567) DIV 2;
    small:=Round(small/3\Dec:=1)+Pow(2,-1)+Sqrt(16)+ATan2(1,-1);
    TPWrite ValToStr(big);
  ENDPROC
ENDMODULE
