! RAPID Instructions, SearchL: at 50 mm/s \Stop goes on for 1 to 3 mm, \SStop 4 to 8, \PStop 15 to 25.
MODULE how_a_search_stops
  CONST robtarget p1:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2:=[[700,100,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PERS bool touched:=FALSE;
  VAR robtarget found;
  VAR intnum touch;

  PROC main()
    CONNECT touch WITH it_touches;
    begin;
    SearchL\Stop,touched,found,p2,v50,tool0;
    TPWrite "stiff "\Bool:=went_on(1,3);       ! -> stiff TRUE
    begin;
    SearchL\SStop,touched,found,p2,v50,tool0;
    TPWrite "soft "\Bool:=went_on(4,8);        ! -> soft TRUE
    begin;
    SearchL\PStop,touched,found,p2,v50,tool0;
    TPWrite "on the path "\Bool:=went_on(15,25);       ! -> on the path TRUE
    begin;
    SearchL touched,found,p2,v50,tool0;
    TPWrite "to the end "\Bool:=went_on(60,90);        ! -> to the end TRUE
  ENDPROC

  PROC begin()
    touched:=FALSE;
    MoveJ p1,v500,fine,tool0;
    ITimer\Single,0.5,touch;
  ENDPROC

  TRAP it_touches
    touched:=TRUE;
  ENDTRAP

  FUNC bool went_on(num least,num most)
    VAR num way;
    way:=Distance(found.trans,CPos(\Tool:=tool0));
    RETURN least<=way AND way<=most;
  ENDFUNC
ENDMODULE
