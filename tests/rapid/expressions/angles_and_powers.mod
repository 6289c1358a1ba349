! RAPID Functions, ACos: arguments out of range and exact values.
MODULE angles_and_powers
  PROC main()
    VAR num n:=2;
    TPWrite ValToStr(ACos(0.5));            ! -> 60
    TPWrite ValToStr(ASin(-1));             ! -> -90
    TPWrite ValToStr(ATan2(-1,-1));         ! -> -135
    TPWrite ValToStr(ATan2(0,-1));          ! -> 180
    TPWrite ValToStr(Trunc(-0.3852138\Dec:=3)); ! -> -0.385
    TPWrite ValToStr(Round(0.3852138\Dec:=3)); ! -> 0.385
    TPWrite ValToStr(Round(-2.5));          ! -> -3
    TPWrite ValToStr(Pow(2,-2));            ! -> 0.25
    TPWrite ValToStr(Sqrt(2));              ! -> 1.41421
    TPWrite ValToStr(Exp(1));               ! -> 2.71828
    Decr n;
    TPWrite ValToStr(n);                    ! -> 1
    Add n,-5;
    TPWrite ValToStr(n);                    ! -> -4
    Clear n;
    TPWrite ValToStr(n);                    ! -> 0
    TPWrite ValToStr(10 DIV 3)+ValToStr(10 MOD 3)+ValToStr(-7 DIV 2)+ValToStr(-7 MOD 2); ! -> 31-3-1
    TPWrite ValToStr(SqrtDnum(2));          ! -> 1.4142135623731
    TPWrite ValToStr(PowDnum(2,40));        ! -> 1099511627776
    TPWrite ValToStr(RoundDnum(0.3852138754655357\Dec:=3)); ! -> 0.385
    TPWrite ValToStr(BitLShDnum(8,2))+" "+ValToStr(BitAndDnum(12,10)); ! -> 32 8
    TPWrite ValToStr(BitNegDnum(3\Size:=4)); ! -> 12
    TryInt 2.5;
    TPWrite "after";                        ! -> after
  ERROR
    IF ERRNO=ERR_INT_NOTVAL TPWrite "not whole"; ! -> not whole
    TRYNEXT;
  ENDPROC
ENDMODULE
