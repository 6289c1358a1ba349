MODULE num_or_dnum
  ! A literal for a parameter that takes num or dnum follows the data beside it, or stays exact.
  VAR num n:=1;
  VAR dnum d:=1;
  VAR signalgo group;

  PROC main()
    Add d, 0.2;
    TPWrite ValToStr(d);                                        ! -> 1.2
    Add d, -(0.1+0.1);
    TPWrite ValToStr(d=1.0);                                    ! -> TRUE
    Add n, 0.2;
    TPWrite ValToStr(n=1.2);                                    ! -> TRUE
    TPWrite DnumToStr(NumToDnum(n),15);                         ! -> 1.200000047683716
    Add d, 4294967295;
    TPWrite DnumToStr(d,0);                                     ! -> 4294967296
    AliasIO "go1", group;
    SetGO group, 4294967295;
    TPWrite DnumToStr(GOutputDnum(group),0);                    ! -> 4294967295
    SetGO group, 8388609+1;
    TPWrite DnumToStr(GOutputDnum(group),0);                    ! -> 8388610
    TPWrite ValToStr(4294967295);                               ! -> 4294967295
    TPWrite ValToStr(0.1);                                      ! -> 0.1
    TryInt 4294967295;
    TPWrite ValToStr(d>4294967295);                             ! -> TRUE
    ExitCycle;
  ENDPROC
ENDMODULE
