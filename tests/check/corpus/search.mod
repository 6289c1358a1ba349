MODULE search
  VAR robtarget pFound;
  CONST robtarget pFrom:=[[700,0,500],[0,1,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PERS tooldata tProbe:=[TRUE,[[0,0,88.5],[1,0,0,0]],[-1,[0,0,0],[1,0,0,0],0,0,0]];
  PROC main()
    MoveJ pFrom,v500,fine,tProbe;
    SearchL\Stop,diProbe,pFound,Offs(pFrom,0,0,-100),v20,tProbe;
    TPWrite "Found at z = "\Num:=pFound.trans.z;
  ERROR
    TEST ERRNO
    CASE ERR_WHLSEARCH:
      TPWrite "Nothing found";
      StorePath;
      MoveL pFrom,v100,fine,tProbe;
      RestoPath;
      ClearPath;
      StartMove;
      RETURN;
    CASE ERR_SIGSUPSEARCH:
      Stop\NoRegain;
      RETRY;
    DEFAULT:
      RAISE;
    ENDTEST
  ENDPROC
ENDMODULE
