! RAPID Functions, MatrixSolve: equations, bits of bytes and of dnums.
MODULE bits_and_matrices
  PROC main()
    VAR dnum a{2,2}:=[[2,0],[0,4]];
    VAR dnum b{2}:=[2,8];
    VAR dnum x{2};
    VAR byte bits:=5;
    MatrixSolve a,b,x;
    TPWrite ValToStr(x);                    ! -> [1,2]
    BitSet bits,2;
    BitClear bits,1;
    TPWrite ValToStr(bits)+ValToStr(BitCheck(bits,3)); ! -> 6TRUE
    TPWrite ValToStr(BitAnd(12,10))+ValToStr(BitOr(12,10))+ValToStr(BitXOr(12,10))+ValToStr(BitNeg(1)); ! -> 8146254
    TPWrite ValToStr(BitLSh(3,2))+ValToStr(BitRSh(12,2)); ! -> 123
    TPWrite ValToStr(BitOrDnum(12,10))+ValToStr(BitXOrDnum(12,10))+ValToStr(BitRShDnum(16,2)); ! -> 1464
    TPWrite ValToStr(AbsDnum(-2.5))+ValToStr(TruncDnum(-2.57\Dec:=1)); ! -> 2.5-2.5
    TPWrite ValToStr(Abs(-3))+ValToStr(Trunc(2.9)); ! -> 32
  ENDPROC
ENDMODULE
