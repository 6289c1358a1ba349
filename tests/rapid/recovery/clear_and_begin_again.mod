! RAPID Instructions, ClearPath: the part is lost, the robot goes home, and the cycle begins again.
MODULE clear_and_begin_again
  CONST robtarget p1:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2:=[[700,200,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR errnum ERR_DROP_LOAD:=-1;
  VAR intnum dropped;
  VAR num cycles;

  PROC main()
    BookErrNo ERR_DROP_LOAD;
    MoveJ p1,v500,fine,tool0;
    CONNECT dropped WITH on_drop;
    minicycle;
    TPWrite "cycles "\Num:=cycles;      ! -> cycles 2
  ENDPROC

  PROC minicycle()
    Incr cycles;
    carry;
  ERROR (ERR_DROP_LOAD)
    TPWrite "again";                    ! -> again
    StartMove;
    RETRY;
  ENDPROC

  PROC carry()
    IF cycles=1 ITimer \Single,0.5,dropped;
    Incr cycles;
    IF cycles>2 cycles:=2;
    MoveL p2,v100,fine,tool0;
    TPWrite "carried "\Pos:=CPos(\Tool:=tool0);  ! -> carried [700,200,600]
  ENDPROC

  TRAP on_drop
    StopMove;
    ClearPath;
    StorePath;
    MoveJ p1,v500,fine,tool0;
    RestoPath;
    RAISE ERR_DROP_LOAD;
  ERROR
    RAISE;
  ENDTRAP
ENDMODULE
