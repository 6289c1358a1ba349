MODULE unlike
  ! What resembles something known is unknown all the same, and nothing follows from it.
  VAR ScanData scan;                    ! error: N210
  VAR ScanData scans{2};                ! error: N210
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
    n:=Sim(3,4)+1;                      ! error: N209
    sums{N_MAX}:=2;                     ! error: N201
    table{2}:=2;
    SaClose "a";                        ! error: N209
    Moev pPick,scan;                    ! error: N209
    SetDO doTPWrit,1;                   ! warning: I801
  ENDPROC

  PROC take(ScanData what,string how)   ! error: N210
  ENDPROC
ENDMODULE
