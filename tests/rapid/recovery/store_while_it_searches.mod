! RAPID Instructions, StorePath: a trap cannot keep the path of a search.
MODULE store_while_it_searches
  CONST robtarget p1:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2:=[[700,200,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PERS bool touched:=FALSE;
  VAR robtarget found;
  VAR intnum late;

  PROC main()
    MoveJ p1,v500,fine,tool0;
    CONNECT late WITH on_late;
    ITimer\Single,1,late;
    SearchL touched,found,p2,v100,tool0;
  ENDPROC

  TRAP on_late
    StopMove;
    StorePath;                          ! stops: StorePath in a trap while the robot searches; ISleep the interrupt
  ENDTRAP
ENDMODULE
