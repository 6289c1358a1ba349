MODULE socket_server
  ! Commands: "1 x y z" moves, "2" reads
  VAR socketdev server_socket;
  VAR socketdev client_socket;
  VAR string received;
  VAR string sIp:="192.168.125.1";
  LOCAL VAR num nParams;
  LOCAL VAR num params{10};
  PROC main()
    ServerOpen;
    WHILE TRUE DO
      SocketReceive client_socket\Str:=received\Time:=WAIT_MAX;
      Parse received;
      TEST params{1}
      CASE 1:
        MoveL Offs(CRobT(\Tool:=tool0\WObj:=wobj0),params{2},params{3},params{4}),v100,fine,tool0;
        SocketSend client_socket\Str:="1 1\0A";
      CASE 2,3:
        SocketSend client_socket\Str:=NumToStr(params{1},0)+" "+PosText(CPos());
      DEFAULT:
        TPWrite "Illegal code: "\Num:=params{1};
      ENDTEST
    ENDWHILE
  ERROR
    IF ERRNO=ERR_SOCK_TIMEOUT THEN
      RETRY;
    ELSEIF ERRNO=ERR_SOCK_CLOSED THEN
      SocketClose client_socket;
      ServerOpen;
      RETRY;
    ELSE
      TPWrite "Error "\Num:=ERRNO;
      RAISE;
    ENDIF
  ENDPROC
  PROC ServerOpen()
    VAR string client_ip;
    SocketCreate server_socket;
    SocketBind server_socket,sIp,5000;
    SocketListen server_socket;
    SocketAccept server_socket,client_socket\ClientAddress:=client_ip\Time:=WAIT_MAX;
  ENDPROC
  LOCAL PROC Parse(string msg)
    VAR num ind:=1;
    VAR num newInd;
    VAR bool ok;
    nParams:=0;
    WHILE ind<=StrLen(msg) AND nParams<10 DO
      newInd:=StrFind(msg,ind," ")+1;
      nParams:=nParams+1;
      ok:=StrToVal(StrPart(msg,ind,newInd-ind-1),params{nParams});
      IF NOT ok params{nParams}:=0;
      ind:=newInd;
    ENDWHILE
  ENDPROC
  FUNC string PosText(pos p)
    RETURN "["+NumToStr(p.x,1)+","+NumToStr(p.y,1)+","+NumToStr(p.z,1)+"]";
  ENDFUNC
ENDMODULE
