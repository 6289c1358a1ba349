MODULE values
  ! Each line that writes says after the arrow what appears on the FlexPendant.
  CONST robtarget p10:=[[600,100,400],[0,0,1,0],[0,-1,0,1],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR num n:=2;
  VAR dnum d:=0.1;
  VAR dnum more:=0.2;
  VAR bool ok;
  VAR pos p;
  VAR num list{3}:=[3,1,2];
  VAR rawbytes raw;
  VAR signaldo gun;
  VAR robtarget moved;
  VAR errnum ERR_GRIP:=-1;

  PROC main()
    TPWrite "n="\Num:=n;                                        ! -> n=2
    TPWrite ValToStr(0.1) + " " + ValToStr(1000000);            ! -> 0.1 1E+06
    TPWrite ValToStr(p10.trans) + ValToStr(n>1);                ! -> [600,100,400]TRUE
    TPWrite ValToStr(list);                                     ! -> [3,1,2]
    Incr n;
    Add d, more;
    TPWrite NumToStr(n,2) + " " + DnumToStr(d,15);              ! -> 3.00 0.300000000000000
    TPWrite ValToStr(d);                                        ! -> 0.3
    ok:=StrToVal("[1, 2.5, -3]",p);
    TPWrite "p=" \Pos:=p;                                       ! -> p=[1,2.5,-3]
    ok:=StrToVal("[9,8,7]",list);
    TPWrite "second " \Num:=list{2};                            ! -> second 8
    TPWrite "sine " \Num:=Sin(30);                              ! -> sine 0.5
    TPWrite "rounded " \Num:=Round(2.565\Dec:=1);               ! -> rounded 2.6
    TPWrite "z " \Num:=EulerZYX(\Z, OrientZYX(30,20,10));       ! -> z 30
    moved:=RelTool(p10,0,0,10);
    TPWrite ValToStr(moved.trans);                              ! -> [600,100,390]
    moved:=Offs(p10,0,0,10);
    TPWrite ValToStr(moved.extax.eax_a);                        ! -> 9E+09
    PackRawBytes 258, raw, RawBytesLen(raw)+1 \IntX:=UINT;
    UnpackRawBytes raw \Network, 1, n \IntX:=UINT;
    TPWrite "swapped " \Num:=n;                                 ! -> swapped 513
    TPWrite ByteToStr(BitOr(8,2)\Bin) + DecToHex("255");        ! -> 00001010FF
    AliasIO "doGun", gun;
    Set gun;
    TPWrite "gun " \Num:=DOutput(gun);                        ! -> gun 1
    BookErrNo ERR_GRIP;
    TPWrite "booked " \Bool:=ERR_GRIP>0;                        ! -> booked TRUE
    fails;
    IF ok OR NOT ok ExitCycle;
    TPWrite "never";
  ENDPROC

  PROC fails()
    n:=Sqrt(-1);
    TPWrite "and on";                                           ! -> and on
    ok:=StrMemb("abc",9,"x");
  ERROR
    IF ERRNO=ERR_ARGVALERR THEN
      TRYNEXT;
    ENDIF
  ENDPROC
ENDMODULE
