MODULE unlike
  ! What resembles something known is unknown all the same, and nothing follows from it.
  VAR ScanData scan;                    ! warning: N210
  VAR ScanData scans{2};                ! warning: N210
  VAR num sums{3};
  VAR num table{N_MAX};                 ! error: N201
  VAR num n;

  PROC main()
    scan:=3;
    n:=scan+1;
    IF scan>2 n:=n+1;
    scans{1}:=scan;
    n:=scan.width;                      ! warning: N215
    take scan,"a";
    take 4,"a";
    n:=Min(3,4)+1;                      ! warning: N209
    sums{N_MAX}:=2;                     ! error: N201
    table{2}:=2;
    SiClose "a";                        ! warning: N209
    Moev pPick,scan;                    ! warning: N209
    SetDO doTPWrit,1;                   ! warning: I801
  ENDPROC

  PROC take(ScanData what,string how)   ! warning: N210
  ENDPROC
ENDMODULE
