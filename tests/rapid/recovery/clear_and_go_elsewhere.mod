! RAPID Instructions, ClearPath: the rest of the path is forgotten, and the next move starts here.
MODULE clear_and_go_elsewhere
  CONST robtarget p1:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2:=[[700,200,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR intnum stop_now;

  PROC main()
    MoveJ p1,v500,fine,tool0;
    CONNECT stop_now WITH on_stop;
    ITimer \Single,0.5,stop_now;
    MoveL p2,v100,fine,tool0;
    TPWrite "short of it "\Bool:=short();        ! -> short of it TRUE
    MoveL p1,v500,fine,tool0;
    TPWrite "x "\Num:=x_now();          ! -> x 700
  ENDPROC

  TRAP on_stop
    StopMove;
    ClearPath;
    StartMove;
  ENDTRAP

  FUNC bool short()
    VAR pos now;
    now:=CPos(\Tool:=tool0);
    RETURN now.y>20 AND now.y<180;
  ENDFUNC

  FUNC num x_now()
    VAR pos now;
    now:=CPos(\Tool:=tool0);
    RETURN Round(now.x);
  ENDFUNC
ENDMODULE
