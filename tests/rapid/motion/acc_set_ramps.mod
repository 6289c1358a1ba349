! RAPID Instructions, AccSet: how quickly accelerations rise. A ramp of p % is taken to let them
! rise over 100/p of the time; the motion is later at rest by the difference, and slow for as long
! around corners.
MODULE acc_set_ramps
  CONST robtarget p:=[[850,-350,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST num wide:=0.0015;
  ! Width of the smoothing of this arm, in seconds.
  CONST num smoothing:=0.07248;
  VAR clock watch;
  VAR num full;

  PROC main()
    ConfL \Off;
    ConfJ \Off;
    MoveJ p,v500,fine,tool0;
    ! One straight move of 1.2 s at even speed.
    full:=one_line();
    AccSet 100,50;                                                  ! twice as long
    TPWrite "half: "\Bool:=is(one_line()-full,smoothing);                ! -> half: TRUE
    AccSet 100,10;                                                  ! ten times
    TPWrite "a tenth: "\Bool:=is(one_line()-full,9*smoothing);             ! -> a tenth: TRUE
    AccSet 100,3;                                                   ! no lower than 10
    TPWrite "less: "\Bool:=is(one_line()-full,9*smoothing);                ! -> less: TRUE
    AccSet 100,100\FinePointRamp:=50;                               ! twice at the end
    TPWrite "at the end: "\Bool:=is(one_line()-full,smoothing);          ! -> at the end: TRUE
    AccSet 100,50\FinePointRamp:=50;                                ! 25 % together, four times at the end
    TPWrite "both: "\Bool:=is(one_line()-full,3*smoothing);                ! -> both: TRUE
    AccSet 100,100;                                                 ! without FinePointRamp there is none
    TPWrite "as before: "\Bool:=is(one_line()-full,0);              ! -> as before: TRUE
    ! The robot stands still in between as long as ever, so each of three moves takes as much more.
    full:=three_lines();
    AccSet 100,50;
    TPWrite "three: "\Bool:=is(three_lines()-full,3*smoothing);          ! -> three: TRUE
    ! On the way a lower ramp acts within a second of its move, a higher one from the next stop on.
    full:=round_a_corner(100,100);
    TPWrite "lower: "\Bool:=is(round_a_corner(100,50)-full,0.092);       ! -> lower: TRUE
    TPWrite "higher: "\Bool:=is(round_a_corner(50,100)-full,0.092);      ! -> higher: TRUE
    TPWrite "after it: "\Bool:=is(round_a_corner(100,100)-full,0);  ! -> after it: TRUE
  ENDPROC

  FUNC bool is(num longer,num wanted)
    RETURN Abs(longer-wanted)<wide;
  ENDFUNC

  FUNC num one_line()
    RETURN came(Offs(p,0,600,0));
  ENDFUNC

  FUNC num came(robtarget there)
    VAR num seconds;
    ClkReset watch;
    ClkStart watch;
    MoveL there,v500,fine,tool0;
    seconds:=ClkRead(watch);
    MoveL p,v1000,fine,tool0;
    RETURN seconds;
  ENDFUNC

  FUNC num three_lines()
    ClkReset watch;
    ClkStart watch;
    MoveL Offs(p,0,100,0),v500,fine,tool0;
    MoveL Offs(p,0,200,0),v500,fine,tool0;
    MoveL p,v500,fine,tool0;
    RETURN ClkRead(watch);
  ENDFUNC

  FUNC num round_a_corner(num before,num after)
    VAR num seconds;
    ClkReset watch;
    ClkStart watch;
    AccSet 100,before;
    MoveL Offs(p,0,0,-100),v500,z10,tool0;
    AccSet 100,after;
    MoveL Offs(p,0,600,-100),v500,fine,tool0;       ! note: R113
    seconds:=ClkRead(watch);
    MoveL p,v1000,fine,tool0;
    RETURN seconds;
  ENDFUNC
ENDMODULE
